// The one component of the page: it gives our own modules a place, and a way to the server and back.

export default {
  template: '<div class="st-root"></div>',
  async mounted() {
    const {start} = await import("/web/main.js");
    this.leave = start(this.$el, {say: message => this.$emit("say", message), connection: () => window.socket});
  },
  unmounted() { this.leave?.(); },
};
